tagmetry locate photo.png --map hall.yaml --camera camera.yaml \
    --out where.jsonl --picture where.png
