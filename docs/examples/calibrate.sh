tagmetry calibrate boards --board chessboard:7x5:30mm \
  --out webcam.yaml --report webcam.html --csv tables
