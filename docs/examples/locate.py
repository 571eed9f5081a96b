import tagmetry

camera = tagmetry.load_camera("camera.yaml")
hall = tagmetry.load_map("hall.yaml")
localizer = tagmetry.Localizer(hall, camera)
detector = tagmetry.Detector(hall.families)

with tagmetry.open_source("photo.png") as source:
    for image in source:
        place = localizer.locate(detector.detect(image.pixels, camera))
        if not place.hypotheses:
            print("not known:", place.why)
            continue
        print("camera at", place.best.T_world_camera.translation.round(3), "m")
        print("        ±", (place.covariance.diagonal()[:3] ** 0.5).round(4), "m")
        print("by", len(place.used), "markers; a flip has", f"{place.ambiguity:.1g}")
