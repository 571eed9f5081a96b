tagmetry compare where.tum true.tum --gap 1 --picture errors.png
