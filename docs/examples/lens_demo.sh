tagmetry lens demo --depth 1.0m --turn 40 --out trace.jsonl
