from pathlib import Path

import cv2

from tagmetry.calibrate import calibrate
from tagmetry.calibrate.guidance import verdict
from tagmetry.calibrate.targets import find_board
from tagmetry.calibrate.view import BoardView
from tagmetry.files import save_camera
from tagmetry.markers import Chessboard

board = Chessboard(7, 5, 0.030)  # inner corners, metres
found = [
    find_board(cv2.imread(str(path)), board, source=path.name)
    for path in sorted(Path("boards").glob("*.png"))
]
for lost in (one for one in found if not isinstance(one, BoardView)):
    print(f"{lost.source}: {lost.reason}")

calibration = calibrate([one for one in found if isinstance(one, BoardView)], "brown1")
camera = calibration.camera
print(f"fx {camera.focal_px[0]:.2f} ± {camera.covariance[0, 0] ** 0.5:.2f} px")
print(verdict(calibration, board).words)
save_camera(camera, "webcam.yaml")
