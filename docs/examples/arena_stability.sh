tagmetry arena stability --delay-ms 100 --picture stability.png
tagmetry arena stability lab.yaml --delay-ms 80 --stiffness 6
