tagmetry camera show camera.yaml
tagmetry camera convert camera.yaml half.yaml --scale-to 640x360
