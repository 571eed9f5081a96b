tagmetry plan --camera camera.yaml --size 120mm --distance 2.5
tagmetry plan --camera camera.yaml --size 120mm --distance 2.5 --tilt 5 --noise 6 --speed 0.5
tagmetry plan --camera camera.yaml --distance 2.5 --want 2mm
tagmetry plan --camera camera.yaml --size 30mm --distance 1 --picture volume.png
