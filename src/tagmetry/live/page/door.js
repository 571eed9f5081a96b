// Who this page is: the sign-in, the state of the connection, and which controls work.
const $ = (id) => document.getElementById(id);

export class Door {
  constructor(onSignedIn) {
    this.role = "viewer";
    this.isLive = false;
    $("sign-in").addEventListener("submit", async (event) => {
      event.preventDefault();
      const answer = await fetch("/sign-in", { method: "POST", body: $("token").value });
      $("token").value = "";
      $("sign-in-answer").textContent = answer.ok ? "" : await answer.text();
      if (answer.ok) onSignedIn();
    });
  }

  get commands() { return this.isLive && this.role === "operator"; }

  welcome(role) {
    this.role = role;
    $("sign-in").hidden = role === "operator";
    this.show("live");
  }

  show(state) {
    this.isLive = state === "live";
    const texts = { live: this.commands ? "live · you command" : "live · looking only",
      lost: "connection lost; trying again…", "sign in": "sign in to see" };
    $("connection").textContent = texts[state];
    $("connection").className = this.isLive ? "live" : "lost";
    if (state === "sign in") $("sign-in").hidden = false;
    $("stop").disabled = !this.isLive; // who may look may stop
    this.unlock();
  }

  // Controls with `data-operator` work for operators; "sometimes": their room says when.
  unlock() {
    for (const one of document.querySelectorAll("[data-operator]")) {
      if (!this.commands) one.disabled = true;
      else if (one.dataset.operator !== "sometimes") one.disabled = false;
    }
  }
}
