import tagmetry
from tagmetry.camera import cropped, distortion_reach, scaled

camera = tagmetry.load_camera("camera.yaml")  # ROS, OpenCV or Kalibr
print(camera.name, camera.size_px, camera.focal_px, camera.lens.coefficients)
print(f"the lens model covers {distortion_reach(camera).covered_share:.0%} of the image")

half = scaled(camera, camera.width_px // 2, camera.height_px // 2)
tagmetry.save_camera(half, "half.yaml")
middle = cropped(camera, left_px=320, top_px=180, width_px=640, height_px=360)
tagmetry.save_camera(middle, "middle.yaml")
