tagmetry print sheet --family tag36h11 --ids 1-24 --size 50mm --out robots.pdf
tagmetry print marker --family tag36h11 --id 0 --size 140mm --out floor.pdf
