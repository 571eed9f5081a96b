from tagmetry.twin.camera import (
    BeforeCamera,
    TwinCamera,
    facing_camera,
    markers_before_camera,
    webcam,
)
from tagmetry.twin.scenes import Along

approaching = Along(lambda time_s: facing_camera(0.4 - 0.2 * time_s, turn_deg=30))
scene = markers_before_camera(BeforeCamera(approaching, id=7, size_m=0.01))
with TwinCamera(scene, webcam(), quick=True, seed=1) as camera:
    for name in ("auto_focus", "auto_exposure"):
        camera.controls.write(name, 0)
    camera.controls.write("zoom", 450)
    camera.controls.write("focus", 43)
    for image in camera:
        (marker,) = camera.truth().markers
        print(
            f"{image.time_s:.3f} s, zoom {camera.setting().zoom_percent:g}: "
            f"{marker.depth_m * 1000:.1f} mm, {marker.side_px:.1f} px, blur {marker.disc_px:.1f} px"
        )
        if image.sequence == 5:
            break
