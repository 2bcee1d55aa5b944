// A hand-held control beside the vehicles of one agent: JSON lines over its socket.
import { connect } from "node:net";

export class HandHeld {
  static async open(path) {
    const control = new HandHeld();
    control.socket = connect(path);
    control.text = "";
    control.waiting = [];
    control.socket.on("data", (data) => {
      control.text += data;
      for (let end; (end = control.text.indexOf("\n")) >= 0; control.text = control.text.slice(end + 1)) {
        control.waiting.shift()(JSON.parse(control.text.slice(0, end)));
      }
    });
    await new Promise((done, failed) => control.socket.once("connect", done).once("error", failed));
    return control;
  }
  send(message) {
    this.socket.write(`${JSON.stringify(message)}\n`);
    return new Promise((done) => this.waiting.push(done));
  }
  close() {
    this.socket.destroy();
  }
}
