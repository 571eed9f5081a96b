tagmetry arena twin --controller spread.py --on-board --robots 3 --seconds 2
tagmetry arena twin --controller spread.py --on-board --robots 3 --seconds 2 --processes
