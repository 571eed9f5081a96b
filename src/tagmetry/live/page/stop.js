// The red button, and the space bar, which stops in every room whatever has the focus.
export function watchStop(stop) {
  document.getElementById("stop").addEventListener("click", stop);
  addEventListener("keydown", (event) => {
    if (event.code !== "Space" || event.repeat || isTyping(event.target)) return;
    event.preventDefault();
    stop();
  });
  addEventListener("keyup", (event) => {
    if (event.code === "Space" && !isTyping(event.target)) event.preventDefault();
  });
}

const NO_TEXT = new Set(["button", "checkbox", "radio", "range", "submit", "number"]);

// A space is text only where text is typed; a box, a slider or a number has no use for it.
function isTyping(element) {
  if (element instanceof HTMLInputElement) return !NO_TEXT.has(element.type);
  return element instanceof HTMLTextAreaElement;
}
