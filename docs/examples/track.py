from tagmetry import Tracker, open_source

tracker = Tracker(["tag36h11"])
with open_source("video.mp4") as video:
    for image in video:
        for marker in tracker.track(image.pixels, image.time_s, image.camera):
            print(f"{image.time_s:.2f} s: {marker.id} at", marker.center_px.round(2))
        for lost in tracker.lost:
            print(f"{image.time_s:.2f} s: {lost.id} not seen for {lost.age_s:.2f} s")
print("a new marker is found within", tracker.images_to_acquire(1280, 720), "images")
