tagmetry print sheet --family 4x4_50 --ids 0-9 --size 10mm --out micro.pdf
tagmetry print marker --family 4x4_50 --id 0 --size 10mm --out micro.svg  # to etch
