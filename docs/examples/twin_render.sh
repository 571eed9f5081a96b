tagmetry twin render desk.yaml --out desk
tagmetry detect desk --family tag36h11 --size 80mm --camera desk/camera.yaml --out desk.jsonl
