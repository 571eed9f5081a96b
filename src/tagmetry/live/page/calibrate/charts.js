// Where the views have shown corners, and how the uncertainty fell from view to view.
import { prepared } from "../canvas.js";

const ENOUGH = 40; // corners in a cell, for its full colour

export function drawCoverage(canvas, rows) {
  const { pen, width, height, color } = prepared(canvas);
  const down = rows.length || 6, across = rows[0]?.length ?? 8;
  const w = width / across, h = height / down;
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  for (let y = 0; y < down; y++) {
    for (let x = 0; x < across; x++) {
      const count = rows[y]?.[x] ?? 0;
      pen.globalAlpha = Math.min(count / ENOUGH, 1) * 0.85;
      pen.fillStyle = color("--accent");
      pen.fillRect(x * w + 1, y * h + 1, w - 2, h - 2);
      pen.globalAlpha = 1;
      pen.strokeStyle = color("--line");
      pen.strokeRect(x * w + 1, y * h + 1, w - 2, h - 2);
      pen.fillStyle = color("--ink");
      if (count) pen.fillText(String(count), (x + 0.5) * w, (y + 0.5) * h);
    }
  }
}

export function drawUncertainty(canvas, values, wanted) {
  const { pen, width, height, color } = prepared(canvas);
  const known = [...values, wanted].filter((one) => one > 0);
  if (!values.length || !known.length) return;
  const low = Math.log10(Math.min(...known)) - 0.15, high = Math.log10(Math.max(...known)) + 0.15;
  const y = (px) => 8 + (height - 16) * (high - Math.log10(px)) / (high - low);
  const x = (n) => 44 + (width - 56) * (values.length > 1 ? n / (values.length - 1) : 0.5);
  pen.fillStyle = pen.strokeStyle = color("--soft");
  pen.textBaseline = "middle";
  for (let power = Math.ceil(low); power <= high; power++) {
    pen.fillText(`${10 ** power} px`, 2, y(10 ** power));
  }
  dashed(pen, color("--good"), y(wanted), width);
  pen.strokeStyle = pen.fillStyle = color("--accent");
  pen.lineWidth = 2;
  pen.beginPath();
  values.forEach((one, n) => { if (one > 0) pen.lineTo(x(n), y(one)); });
  pen.stroke();
  values.forEach((one, n) => { if (one > 0) pen.fillRect(x(n) - 3, y(one) - 3, 6, 6); });
}

function dashed(pen, color, y, width) {
  pen.strokeStyle = color;
  pen.setLineDash([5, 4]);
  pen.beginPath();
  pen.moveTo(44, y);
  pen.lineTo(width, y);
  pen.stroke();
  pen.setLineDash([]);
}
