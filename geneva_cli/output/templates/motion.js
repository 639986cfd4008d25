// Where things are at an input angle t, in degrees from the start of the turn.

// The value of a track: its Chebyshev series between the two ends beside t, by Clenshaw's sums.
function valueAt({ ends, series }, t) {
  let low = 0, high = series.length;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (ends[middle] <= t) low = middle; else high = middle;
  }
  const a = ends[low], b = ends[low + 1], terms = series[low];
  const u = Math.min(1, Math.max(-1, (2 * t - a - b) / (b - a)));
  let one = 0, two = 0;
  for (let k = terms.length - 1; k > 0; k--) [one, two] = [2 * u * one - two + terms[k], one];
  return u * one - two + terms[0];
}

// The same after some whole turns more.
function afterTurns(track, t, turns) {
  return valueAt(track, t) + turns * track.gain;
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
function pushAt({ at: a, x, y, force_x, force_y }, t) {
  const last = a.length - 1;
  if (last < 0 || t < a[0] || t > a[last]) return null;
  let i = 0;
  while (i < last - 1 && a[i + 1] <= t) i++;
  const h = last ? a[i + 1] - a[i] : 0, u = h > 0 ? (t - a[i]) / h : 0;
  return [x, y, force_x, force_y].map((c) => (last ? c[i] + u * (c[i + 1] - c[i]) : c[0]));
}

// What the wheel does at t.
function stateAt(states, t) {
  return states.find((s) => t >= s.start && t < s.end) || states[states.length - 1];
}

// The input's angle as it is shown: from -180 to 180 where a turn is one of the input's.
function shownDeg(scene, t) {
  const x = scene.start_deg + t;
  if (scene.turn_deg > 360) return x;
  return x > 180 ? x - 360 : x;
}
