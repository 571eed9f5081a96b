from pathlib import Path

import cv2

from tagmetry.calibrate import BoardView, calibrate, explain_board, look_again, verdict
from tagmetry.files import save_camera
from tagmetry.markers import Chessboard

board = Chessboard(7, 5, 0.030)  # inner corners, metres
looked = [
    explain_board(cv2.imread(str(path)), board, source=path.name)
    for path in sorted(Path("boards").glob("*.png"))
]
for lost in (one.result for one in looked if not isinstance(one.result, BoardView)):
    print(f"{lost.source}: {lost.reason}")

views = [one.result for one in looked if isinstance(one.result, BoardView)]
first = calibrate(views, "brown1")
calibration = calibrate(look_again(first, looked, board), "brown1")
camera = calibration.camera
print(f"fx {camera.focal_px[0]:.2f} ± {camera.covariance[0, 0] ** 0.5:.2f} px")
print(verdict(calibration, board).words)
save_camera(camera, "webcam.yaml")
