tagmetry arena twin --seconds 22 --picture ways.png
tagmetry arena twin --controller formation --robots 4 --seconds 10
tagmetry arena twin --controller keep_away.py --robots 6 --seconds 5 --delay 0.1 --loss 0.05
