tagmetry print sheet --family tag36h11 --ids 0-5 --size 60mm --paper a4 --out sheet.pdf
