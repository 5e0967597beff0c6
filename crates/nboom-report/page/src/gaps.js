// Curves with values that cannot be drawn.

/**
 * Numbers of the values that no line reaches: on both sides comes a value that cannot be drawn, which is null, or none.
 * Where a value is undefined only other curves have one.
 */
export function alone(values) {
  const isGap = (i, way) => {
    let k = i + way;
    while (k in values && values[k] === undefined) k += way;
    return !(k in values) || values[k] === null;
  };
  return Array.from(values.keys()).filter((i) => (values[i] ?? null) !== null && isGap(i, -1) && isGap(i, 1));
}
