from tagmetry import Detector, family, open_source
from tagmetry.record import ImageResult
from tagmetry.record.mcap import Recorder, Replay, export_recording

detector = Detector([family("tag36h11")])
with open_source("photo.png") as source, Recorder("run.mcap", jpeg_quality=None) as recorder:
    for image in source:
        recorder.image(image)
        recorder.detections(ImageResult.from_image(image, detector.detect(image.pixels)))

with Replay("run.mcap") as replay:
    for image in replay:
        print(image.source, [seen.id for seen in detector.detect(image.pixels)])

print(export_recording("run.mcap", "tables"))
