tagmetry detect video.mp4 --family tag36h11 --size 0=140mm,1=50mm,2=50mm \
    --camera camera.yaml --out robots.parquet
