tagmetry print marker --family tag36h11 --id 7 --size 140mm --out wall7.pdf
tagmetry print board grid --family tag36h11 --first-id 20 --columns 3 --rows 2 \
    --size 80mm --gap 20mm --paper a3 --out board.pdf
