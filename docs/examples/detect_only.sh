tagmetry detect photo.png --family tag36h11 --overlay overlay.png --out markers.jsonl
