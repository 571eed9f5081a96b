tagmetry detect video.mp4 --track --family tag36h11 --size 140mm --camera camera.yaml \
    --out tracked.jsonl
