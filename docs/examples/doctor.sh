tagmetry doctor photo.png
