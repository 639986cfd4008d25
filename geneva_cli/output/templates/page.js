"use strict";
(() => {
  const scene = JSON.parse(document.getElementById("scene").textContent);
  const make = (name, to, attributes = {}) => {
    const element = document.createElementNS("http://www.w3.org/2000/svg", name);
    set(element, attributes);
    to.append(element);
    return element;
  };
  const set = (element, attributes) => {
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  };
  const by = (id) => document.getElementById(id);
  const size = scene.size, degrees = 180 / Math.PI;

  const centre = scene.bodies.find((b) => !b.name.startsWith("wheel"))?.centre ?? [0, 0];
  set(by("centres"), { x1: 0, y1: 0, x2: centre[0], y2: -centre[1] });
  const bars = scene.bars.map((bar, number) => {
    const group = by("bars");
    if (bar.plates.length) return { bar, plates: bar.plates.map(({ joint }, i) => [joint, by(`link-${number}-${i}`)]) };
    if (bar.radius) return { bar, rim: make("circle", group, { class: "rim", r: bar.radius }) };
    const kind = bar.joints.length > 2 ? "polygon" : "line";
    const shape = bar.joints.length > 1 ? make(kind, group) : null;
    const joint = { class: "joint", r: 0.009 * size };
    return { bar, shape, joints: bar.joints.map(() => make("circle", by("rollers"), joint)) };
  });
  for (const { joints } of bars) for (const joint of joints ?? []) by("bars").append(joint);
  const rollers = scene.rollers.map(() => make("circle", by("rollers"), { r: scene.roller_radius }));
  const most = Math.max(...scene.pushes.flatMap((p) => p.force_x.map((f, i) => Math.hypot(f, p.force_y[i]))), 0);
  const pushes = scene.pushes.map(() => ({
    line: make("line", by("pushes")),
    head: make("path", by("pushes"), { d: "M0,0L-10,-4.5L-10,4.5Z" }),
    spot: make("circle", by("pushes"), { r: 0.006 * size }),
  }));

  // curves: x is the input's angle in the figure's own window
  const [from, to] = scene.window;
  const panels = scene.panels.map((panel) => {
    const figure = document.createElement("figure"), caption = document.createElement("figcaption");
    const name = document.createElement("span"), value = document.createElement("b");
    name.textContent = panel.name;
    caption.append(name, value);
    const plot = document.createElement("div");
    plot.className = "plot";
    figure.append(caption, plot);
    by("curves").append(figure);
    const svg = make("svg", plot, { viewBox: "0 0 1000 100", preserveAspectRatio: "none" });
    const low = panel.low, span = panel.high - panel.low || 1;
    const x = (v) => (1000 * (v - from)) / (to - from), y = (v) => 96 - (92 * (v - low)) / span;
    for (const { start, end, moves } of scene.states) {
      const left = x(from + start), right = x(Math.min(from + end, to)); // the window may be shorter than the turn
      if (moves || left >= right) continue;
      make("rect", svg, { class: "rest", x: left, width: right - left, y: 0, height: 100 });
    }
    const label = (name, text, place) => {
      const mark = document.createElement("span");
      mark.className = name;
      mark.textContent = text;
      Object.assign(mark.style, place);
      plot.append(mark);
    };
    for (const [v, text] of panel.ticks) {
      make("line", svg, { class: "tick", x1: 0, x2: 1000, y1: y(v), y2: y(v) });
      label("y", text, { top: `${y(v)}%` });
    }
    for (const [v, text] of scene.angles) {
      make("line", svg, { class: "tick", x1: x(v), x2: x(v), y1: 0, y2: 100 });
      label("x", text, { left: `${x(v) / 10}%` });
    }
    if (low < 0 && panel.high > 0) make("line", svg, { class: "zero", x1: 0, x2: 1000, y1: y(0), y2: y(0) });
    let last = null;
    for (const [xs, ys] of panel.pieces) {
      const points = xs.map((v, i) => `${x(v).toFixed(1)},${y(ys[i]).toFixed(2)}`);
      if (last) points.unshift(last);
      last = points[points.length - 1];
      make("polyline", svg, { points: points.join(" ") });
    }
    const cursor = make("line", svg, { class: "cursor", y1: 0, y2: 100 });
    return { panel, value, cursor, x };
  });

  const inWindow = (t) => from + (((t % (to - from)) + (to - from)) % (to - from));
  function curveAt(panel, x) {
    let value = 0; // where the curve jumps, what it jumps to
    for (const [xs, ys] of panel.pieces) {
      const n = xs.length - 1;
      if (x < xs[0] || x > xs[n]) continue;
      let i = 0;
      while (i < n - 1 && xs[i + 1] < x) i++;
      value = n ? ys[i] + ((x - xs[i]) / (xs[i + 1] - xs[i] || 1)) * (ys[i + 1] - ys[i]) : ys[0];
    }
    return value;
  }

  let t = 0, turns = 0, sense = 1, said = "";
  function show() {
    if (scene.frame) {
      const { centre: [x, y], angle } = scene.frame, turned = -afterTurns(angle, t, turns) * degrees;
      set(by("frame"), { transform: `rotate(${turned} ${x} ${-y})` });
    }
    for (const { name, centre: [x, y], angle, travel } of scene.bodies) {
      const turned = -afterTurns(angle, t, turns) * degrees;
      const up = y + (travel ? afterTurns(travel, t, turns) : 0);
      set(by(name), { transform: `translate(${x} ${-up}) rotate(${turned})` });
    }
    for (const { bar, rim, shape, joints, plates } of bars) {
      const at = bar.joints.map(([x, y]) => [valueAt(x, t), -valueAt(y, t)]);
      for (const [joint, plate] of plates ?? []) {
        const [x0, y0] = at[0], [x1, y1] = at[joint || 1], [x, y] = at[joint];
        const turned = Math.atan2(y1 - y0, x1 - x0) * degrees;
        set(plate, { transform: `translate(${x} ${y}) rotate(${turned})` });
      }
      if (plates) continue;
      if (rim) { set(rim, { cx: at[0][0], cy: at[0][1] }); continue; }
      if (at.length > 2) set(shape, { points: at.join(" ") });
      else if (shape) set(shape, { x1: at[0][0], y1: at[0][1], x2: at[1][0], y2: at[1][1] });
      joints.forEach((joint, i) => set(joint, { cx: at[i][0], cy: at[i][1] }));
    }
    scene.rollers.forEach(([x, y], i) => set(rollers[i], { cx: valueAt(x, t), cy: -valueAt(y, t) }));
    let force = 0;
    scene.pushes.forEach((push, i) => {
      const { line, head, spot } = pushes[i], at = pushAt(push, t);
      const seen = at && Math.hypot(at[2], at[3]) > 0.002 * most ? "visible" : "hidden";
      for (const element of [line, head, spot]) set(element, { visibility: seen });
      if (seen === "hidden") return;
      const [x, y, fx, fy] = at, long = (0.3 * size) / most;
      force = Math.hypot(fx, fy);
      const end = [x + fx * long, -y - fy * long];
      set(line, { x1: x, y1: -y, x2: end[0], y2: end[1] });
      const turned = Math.atan2(-fy, fx) * degrees;
      set(head, { transform: `translate(${end}) rotate(${turned}) scale(${0.0025 * size})` });
      set(spot, { cx: x, cy: -y });
    });
    const x = inWindow(t);
    for (const { panel, value, cursor, x: place } of panels) {
      set(cursor, { x1: place(x), x2: place(x) });
      const v = curveAt(panel, x), least = 1e-9 * (panel.high - panel.low); // less is rounding
      value.textContent = Math.abs(v) > least ? Number(v.toPrecision(4)) : 0;
    }
    const { moves, words } = stateAt(scene.states, t);
    const { angle, travel } = scene.bodies[0];
    const output = travel
      ? `rack ${afterTurns(travel, t, 0).toFixed(2)} mm`
      : `wheel ${(afterTurns(angle, t, 0) * degrees).toFixed(2)} degrees`;
    const shown = shownDeg(scene, t).toFixed(2);
    const more = moves && force > 1e-9 ? `, with ${Number(force.toPrecision(3))} N` : "";
    const still = stands > 0 ? "; the input stands still" : "";
    const text = words[0].toUpperCase() + words.slice(1) + more + still + ".";
    if (text !== said) by("state").textContent = said = text;
    by("angle").textContent = `${shown}\u00b0`;
    by("input").value = t;
    set(by("input"), { "aria-valuetext": `input ${shown} degrees, ${output}, ${words}` });
  }

  function go(to) {
    t = Math.min(scene.turn_deg, Math.max(0, to));
    show();
  }
  let playing = false, before = 0;
  let stands = 0; // seconds that the input still stands in a dwell
  const speed = by("speed");
  for (const fraction of [0.02, 0.05, 0.1, 0.2, 0.5, 1, 2]) {
    speed.append(new Option(fraction === 1 ? "real time" : `${fraction} of real time`, fraction));
  }
  const wanted = (60 * scene.seconds) / scene.turn_deg; // a turn of the input in 6 s
  const near = (o) => Math.abs(Math.log(o.value / wanted));
  [...speed.options].reduce((a, b) => (near(b) < near(a) ? b : a)).selected = true;
  function frame(now) {
    if (!playing) return;
    const seconds = Math.min(0.1, (now - before) / 1000) * speed.value; // of the machine
    before = now;
    if (stands > 0) {
      stands -= seconds;
      requestAnimationFrame(frame);
      return;
    }
    const run = (sense * scene.turn_deg * seconds) / scene.seconds, here = turns * scene.turn_deg + t;
    let next;
    [next, sense] = between(scene.stops, here + run, sense);
    const pause = pauseBetween(scene.pauses, scene.turn_deg, here, next);
    if (pause !== null) {
      next = pause;
      stands = scene.stop_s;
    }
    turns = Math.floor(next / scene.turn_deg);
    go(next - turns * scene.turn_deg);
    requestAnimationFrame(frame);
  }
  function play(on) {
    playing = on;
    stands = 0;
    set(by("play"), { "aria-pressed": on });
    by("play").textContent = on ? "Stop" : "Play";
    if (on) { before = performance.now(); requestAnimationFrame(frame); }
  }
  by("play").addEventListener("click", () => play(!playing));
  by("input").max = scene.turn_deg;
  by("input").addEventListener("input", (event) => { play(false); turns = 0; go(Number(event.target.value)); });
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches("select, summary")) return;
    const step = event.shiftKey ? 10 : 1;
    const keys = {
      ArrowRight: t + step, ArrowUp: t + step, ArrowLeft: t - step, ArrowDown: t - step,
      Home: 0, End: scene.turn_deg,
    };
    if (event.key === " ") play(!playing);
    else if (event.key in keys) { play(false); turns = 0; go(keys[event.key]); }
    else return;
    event.preventDefault();
  });
  document.addEventListener("keyup", (event) => { if (event.key === " ") event.preventDefault(); });
  show();
  if (!matchMedia("(prefers-reduced-motion: reduce)").matches) play(true);
})();
