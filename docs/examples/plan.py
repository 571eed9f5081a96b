import numpy as np

import tagmetry
from tagmetry.pose.plan import Setup, predict, range_m

camera = tagmetry.load_camera("camera.yaml")
for distance_m in (0.5, 1.0, 2.0, 4.0):
    expected = predict(Setup(camera, size_m=0.12, distance_m=distance_m, tilt_deg=30))
    x_mm, y_mm, z_mm = 1000 * np.sqrt(np.diag(expected.by_corners)[:3])
    print(
        f"at {distance_m} m: ± {x_mm:.3f}, {y_mm:.3f}, {z_mm:.2f} mm by noise, "
        f"{1000 * expected.position_m:.2f} mm in all, flips {expected.flip_probability:.0%}"
    )
print(f"found up to {range_m(Setup(camera, size_m=0.12, distance_m=1)):.1f} m")
