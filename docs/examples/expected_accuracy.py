import tagmetry

size_m, noise_px = 0.010, 0.1
camera = tagmetry.load_camera("camera.yaml")
focal_px = camera.focal_px[0]

for depth_m in (0.05, 0.1, 0.2, 0.5, 1.0):
    side_px = focal_px * size_m / depth_m
    across_m, along_m = depth_m * noise_px / (2 * focal_px), depth_m * noise_px / side_px
    print(
        f"at {depth_m:4.2f} m: {side_px:6.1f} px, ± {1e6 * across_m:5.1f} µm across, "
        f"± {1e6 * along_m:7.1f} µm in depth"
    )
