tagmetry detect video.mp4 --family tag36h11 --size 160mm --camera camera.yaml --out drive.jsonl --overlay drive.mp4
