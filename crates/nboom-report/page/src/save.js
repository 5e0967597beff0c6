// Files that the page gives: curves as tables.

/** Offers a text as a file. */
export function save(name, text, type = 'text/csv') {
  const address = URL.createObjectURL(new Blob([text], { type }));
  const link = document.createElement('a');
  link.href = address;
  link.download = name.replace(/[^\w.-]+/g, '_');
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}

/** Curves over one time as CSV; a heading with a comma or a quote stands in quotes. */
export function csv(headings, columns) {
  const quoted = (text) => (/[",\n\r]|^[=+@-]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
  const lines = [headings.map(quoted).join(',')];
  for (let row = 0; row < columns[0].length; row++) {
    lines.push(columns.map((column) => column[row] ?? '').join(','));
  }
  return lines.join('\n') + '\n';
}
