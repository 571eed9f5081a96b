import tagmetry

detector = tagmetry.Detector(families=["tag36h11"])

with tagmetry.open_source("photo.png") as source:
    for image in source:
        for detection in detector.detect(image.pixels):
            deviation_px = detection.corners_cov_px2.diagonal() ** 0.5
            print(detection.family, detection.id, detection.corners_px.round(2).tolist())
            print("  corners known to", deviation_px.max().round(3), "px")
