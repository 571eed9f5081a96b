from tagmetry.record import read_results

for result in read_results("robots.parquet"):
    poses = {m.detection.id: m.pose.best.uncertain for m in result.markers if m.pose.hypotheses}
    if 0 not in poses:
        continue  # the floor marker is covered
    T_floor_camera = poses.pop(0).inverse()
    for robot, T_camera_robot in poses.items():
        T_floor_robot = T_floor_camera @ T_camera_robot
        x_m, y_m, _ = T_floor_robot.T_a_b.translation
        deviation_m = T_floor_robot.covariance.diagonal()[:2] ** 0.5
        print(f"{result.time_s:7.3f} s  robot {robot}: {x_m:+.4f} {y_m:+.4f} m ± {deviation_m}")
