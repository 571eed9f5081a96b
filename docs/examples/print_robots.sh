tagmetry print sheet --family tag36h11 --ids 1-24 --size 80mm --out robots.pdf
tagmetry print sheet --family tag36h11 --ids 100-103 --size 120mm --out floor.pdf
