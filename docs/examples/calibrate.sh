tagmetry calibrate boards --board chessboard:7x5:30mm --model brown1 \
  --out webcam.yaml --report webcam.html --csv tables
