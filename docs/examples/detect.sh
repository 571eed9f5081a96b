tagmetry detect photo.png --family tag36h11 --size 120mm --camera camera.yaml \
    --overlay overlay.png --out markers.jsonl
