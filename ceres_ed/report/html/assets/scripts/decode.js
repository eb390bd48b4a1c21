// Numbers of the page's data (scene_data.cc), which are text.

function bytesOf(text) {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}
const numbersOf = (data) => data.bits === 32 ? new Uint32Array(bytesOf(data.data).buffer)
                                             : new Uint16Array(bytesOf(data.data).buffer);
function pointsOf(data) {
  const steps = new Uint16Array(bytesOf(data.steps).buffer);
  const points = new Float64Array(steps.length);
  for (let i = 0; i < steps.length; ++i) {
    const low = data.low[i % 3];
    points[i] = low + steps[i] / 65535 * (data.high[i % 3] - low);
  }
  return points;
}
// Values of a field; unknown ones are NaN.
function valuesOf(field) {
  const steps = new Uint16Array(bytesOf(field.steps).buffer);
  return Float64Array.from(
      steps, (s) => s === 65535 ? NaN : field.min + s / 65534 * (field.max - field.min));
}
const short = (value) => Number.isFinite(value) ? String(Number(value.toPrecision(4))) : 'unknown';

const clamp = (value) => Math.min(1, Math.max(0, value));
