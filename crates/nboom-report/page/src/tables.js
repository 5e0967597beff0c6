// Tables of numbers, packed as base64 of little-endian arrays, column after column.

function bytes(base64) {
  const text = atob(base64);
  const found = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) found[i] = text.charCodeAt(i);
  return found.buffer;
}

export class Table {
  constructor({ columns, rows, bytes: size, data }) {
    this.names = columns;
    this.rows = rows;
    const buffer = bytes(data);
    this.columns = columns.map((_, i) => {
      // Times are always whole numbers of f64, whatever the others are.
      const offset = i === 0 ? 0 : 8 * rows + (i - 1) * size * rows;
      return size === 8 || i === 0
        ? new Float64Array(buffer.slice(offset, offset + 8 * rows))
        : Float64Array.from(new Float32Array(buffer.slice(offset, offset + 4 * rows)));
    });
    this.index = new Map(columns.map((name, i) => [name, i]));
  }

  get times() {
    return this.columns[0];
  }

  has(name) {
    return this.index.has(name);
  }

  /** The column of this name; nothing if there is none. */
  column(name) {
    return this.columns[this.index.get(name)];
  }
}

/** The last row at or before a time, from 0. */
export function rowBefore(times, time) {
  let [low, high] = [0, times.length - 1];
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle - 1;
  }
  return low;
}
