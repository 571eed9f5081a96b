import tagmetry
from tagmetry.markers import GridBoard

board = GridBoard(columns=3, rows=2, size_m=0.08, gap_m=0.02, family="tag36h11", first_id=20)
camera = tagmetry.load_camera("camera.yaml")
detector = tagmetry.Detector(families=["tag36h11"])

with tagmetry.open_source("board.png") as source:
    for image in source:
        detections = detector.detect(image.pixels, camera)
        pose = tagmetry.estimate_body_pose(detections, board.body(), camera)
        position_m = pose.best.T_camera_marker.translation
        deviation_mm = 1000 * pose.covariance.diagonal()[:3] ** 0.5
        print(len(pose.used), "markers, board at", position_m.round(4), "m")
        print("±", deviation_mm.round(3), "mm")
        print("corners that disagree:", pose.outliers)
