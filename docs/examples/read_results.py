from tagmetry.record import read_results

for result in read_results("markers.jsonl"):
    for marker in result.markers:
        print(result.source, marker.detection.id, marker.detection.corners_px[0])
        if marker.pose is not None and marker.pose.hypotheses:
            print("  ", marker.pose.best.T_camera_marker.translation, "m")
