from tagmetry.detect import Detector
from tagmetry.lens import MarkerKind
from tagmetry.pipeline.lens import LensTask, measure_marker
from tagmetry.pipeline.lens.twin import calibrated_lens
from tagmetry.twin.camera import ready_camera, webcam

camera = ready_camera("webcam")  # any camera with images and controls
lens = calibrated_lens(webcam(), step=30)  # of your own: load_lens("lens.yaml")
finder = Detector(["tag36h11"])  # anything with detect(image, camera) -> detections
task = LensTask(lens, finder, MarkerKind(size_m=0.010, side_cells=8))

for step in measure_marker(camera, task):  # tracks=True goes on for ever
    zoom, focus = step.setting.zoom_percent, step.setting.focus
    if step.found is None:
        print(f"zoom {zoom:.0f} focus {focus:.0f}: {step.reason}")
        continue
    depth_mm, sd_mm = 1000 * step.found.depth_m, 1000 * step.found.depth_sd_m
    print(f"zoom {zoom:.0f} focus {focus:.0f}: {depth_mm:.2f} mm ± {sd_mm:.2f}", step.is_final)
