from math import radians, tan

import tagmetry

width_px, height_px, view_across_deg = 1280, 720, 60.0
focal_px = width_px / 2 / tan(radians(view_across_deg) / 2)
camera = tagmetry.Camera(
    width_px,
    height_px,
    focal_px=(focal_px, focal_px),
    center_px=((width_px - 1) / 2, (height_px - 1) / 2),
    provenance="a guess from the field of view: distances may be several per cent off",
)
tagmetry.save_camera(camera, "rough.yaml")
