from tagmetry import Detector
from tagmetry.camera import VerifiedControls
from tagmetry.sources.controls import Settling, by_hand, open_controls
from tagmetry.twin.camera import ready_camera

camera = ready_camera("webcam")  # or tagmetry.open_source(0)
detector, settling = Detector(["tag36h11"]), Settling()
with camera, by_hand(VerifiedControls(open_controls(camera))) as controls:
    controls.write("focus", 84)
    settling.expect("focus")
    for image in camera:
        if settling.is_stale(image):
            print(f"image {image.sequence}: taken before the last change was through")
            continue
        zoom = controls.read("zoom")
        for marker in detector.detect(image.pixels):
            print(
                f"image {image.sequence}: {marker.id} is {marker.side_px:.1f} px at zoom {zoom:g}"
            )
        if zoom >= 300:
            break
        controls.write("zoom", zoom + 100)
        settling.expect("zoom")
