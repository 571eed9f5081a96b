from dataclasses import replace

from tagmetry.camera import BankNode, CameraBank
from tagmetry.files import load_bank, load_camera, save_bank

base = load_camera("camera.yaml")
calibrated = [  # where the camera was calibrated: focus setting, focal length
    (0, 1000.0),
    (40, 1003.8),
    (80, 1008.1),
    (120, 1012.0),
]
nodes = [
    BankNode(replace(base, focal_px=(fx_px, fx_px), focus=focus)) for focus, fx_px in calibrated
]
save_bank(CameraBank(tuple(nodes)), "bank.yaml")

bank = load_bank("bank.yaml")
print(f"at focus 53: fx {bank.camera_at(focus=53).focal_px[0]:.1f} px")
for left in bank.leave_one_out():
    print(f"without focus {left.focus:g}: worst {left.worst_px:.2f} px")
