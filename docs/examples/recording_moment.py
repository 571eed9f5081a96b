from tagmetry.record.mcap import Recorder, Timeline

with Recorder("drive.mcap") as recorder:
    for n in range(5):
        recorder.note("/battery", 0.1 * n, {"volts": 8.2 - 0.1 * n})

timeline = Timeline("drive.mcap")
entry = timeline.newest("/battery", at_s=timeline.length_s)
if entry is not None:
    print(entry.content.decode())
