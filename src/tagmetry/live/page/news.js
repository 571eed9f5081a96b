// The line at the bottom: how the measurement does.
export class News {
  take(one) {
    const parts = [one.scenario, `${one.image_rate_hz.toFixed(0)} images/s`,
      `${(1000 * one.turn_s).toFixed(0)} ms each`, `${one.picture_rate_hz.toFixed(0)} pictures/s`,
      one.picture_age_s === null ? "no picture yet"
        : `newest ${(1000 * one.picture_age_s).toFixed(0)} ms`,
      `${one.viewers} ${one.viewers === 1 ? "page" : "pages"}`];
    if (one.late_s > 0.1) parts.push(`this computer is too slow: ${one.late_s.toFixed(2)} s late`);
    if (one.recording) parts.push(`recording ${one.recording}`);
    document.getElementById("news").textContent = parts.join(" · ");
  }
}
