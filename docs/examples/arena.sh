tagmetry arena calibrate floor.png lab.yaml
tagmetry arena run drive lab.yaml --out states.jsonl
