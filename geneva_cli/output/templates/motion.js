// Where things are at an input angle t, in degrees from the start of the turn.

// The value of a track: the cubic between the two knots beside t.
function valueAt(track, t) {
  const { a, v, s } = track;
  const n = a.length;
  if (n === 1) return v[0];
  let low = 0, high = n - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (a[middle] <= t) low = middle; else high = middle;
  }
  const h = a[low + 1] - a[low];
  if (!(h > 0)) return v[low + 1];
  const u = Math.min(1, Math.max(0, (t - a[low]) / h)), w = 1 - u;
  return w * w * (1 + 2 * u) * v[low] + u * u * (1 + 2 * w) * v[low + 1]
    + u * w * h * (w * s[low] - u * s[low + 1]);
}

// The same after some whole turns more.
function afterTurns(track, t, turns) {
  return valueAt(track, t) + turns * (track.g || 0);
}

// Where a machine that ran on for some degrees is, and its sense: it turns back at its stops.
function between(stops, degrees, sense) {
  if (!stops) return [degrees, sense];
  const [low, high] = stops;
  if (degrees > high) return [Math.max(low, 2 * high - degrees), -1];
  if (degrees < low) return [Math.min(high, 2 * low - degrees), 1];
  return [degrees, sense];
}

// Where an input that would run on from one angle to another stands still first, or nothing.
function pauseBetween(pauses, turn, from, to) {
  const least = from + 1e-9 * turn; // it has stood at the angle where it is
  const next = pauses.map((p) => p + turn * Math.ceil((least - p) / turn));
  const first = Math.min(...next);
  return first <= to ? first : null;
}

// Contact and force of a push at t, or nothing: [x, y, fx, fy].
function pushAt(push, t) {
  const a = push[0], last = a.length - 1;
  if (last < 0 || t < a[0] || t > a[last]) return null;
  let i = 0;
  while (i < last - 1 && a[i + 1] <= t) i++;
  const h = last ? a[i + 1] - a[i] : 0, u = h > 0 ? (t - a[i]) / h : 0;
  return push.slice(1).map((c) => (last ? c[i] + u * (c[i + 1] - c[i]) : c[0]));
}

// What the wheel does at t: [start, end, moves, words].
function stateAt(states, t) {
  return states.find((s) => t >= s[0] && t < s[1]) || states[states.length - 1];
}

// The input's angle as it is shown: from -180 to 180 where a turn is one of the input's.
function shownDeg(scene, t) {
  const x = scene.start + t;
  if (scene.turn > 360) return x;
  return x > 180 ? x - 360 : x;
}
