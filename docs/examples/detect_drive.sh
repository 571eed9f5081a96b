tagmetry detect video.mp4 --family tag36h11 --size 140mm --camera camera.yaml \
    --overlay drive.mp4 --out drive.jsonl
