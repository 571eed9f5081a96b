// The line that says what is wrong; that all robots are stopped stays until they are not.
const element = document.getElementById("notice");

export class Notice {
  show(text) {
    if (element.textContent !== text) element.textContent = text; // said aloud once
    element.hidden = !text;
    element.dataset.isStop = "";
  }

  stopped(world) {
    document.body.dataset.stopped = String(world.is_stopped);
    if (!world.is_stopped) {
      if (element.dataset.isStop) this.show("");
      return;
    }
    this.show(`All robots are stopped: ${world.why}`);
    element.dataset.isStop = "yes";
  }
}
