// Bundles each page into one file, in which only the title and the data are missing:
//
//     npm ci && npm run build
//
// The folder `bundle` is what the crate has in it. Its list of hashes names every source, so that a test sees a
// bundle that is older than they are.

import { createHash } from 'node:crypto';
import { mkdirSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { build } from 'esbuild';

const HERE = new URL('.', import.meta.url).pathname;
process.chdir(HERE);

const SOURCES = ['package.json', 'package-lock.json', 'build.mjs', ...readdirSync('src', { recursive: true })
  .map((name) => `src/${name}`).filter((name) => /\.(js|css|html)$/.test(name)).sort()];

/** Pages by name: where each begins, its style sheets, and the libraries that it has in it. */
const PAGES = {
  page: { program: 'src/main.js', styles: ['node_modules/uplot/dist/uPlot.min.css', 'src/style.css'], libraries: ['three', 'uplot'] },
  sweep: { program: 'src/sweep/main.js', styles: ['src/sweep/sweep.css'], libraries: [] },
};

const sha = (kind, text) => createHash('sha256').update(text).digest(kind);
const read = (name) => readFileSync(name, 'utf8');

/** A library with the text of its licence. */
function noticeOf(name) {
  const { version, license } = JSON.parse(read(`node_modules/${name}/package.json`));
  return { title: `${name} ${version}, ${license}`, text: read(`node_modules/${name}/LICENSE`).trim() };
}

async function bundled({ program, styles, libraries }) {
  const { outputFiles: [script] } = await build({
    entryPoints: [program], bundle: true, minify: true, format: 'iife', target: 'es2022', write: false, legalComments: 'none', charset: 'ascii',
  });
  // Nothing in it may end the element that it stands in.
  const code = script.text.trim().replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');
  const parts = {
    '@SCRIPT_HASH@': `sha256-${sha('base64', code)}`, '@STYLE@': styles.map(read).join('\n').trim(), '@SCRIPT@': code,
  };
  let page = read('src/template.html');
  if (libraries.length > 0) {
    const notices = libraries.map(noticeOf).map(({ title, text }) => `${title}\n${text}`).join('\n\n');
    page = page.replace('<style>', () => `<!--\nThis page has in it:\n${notices}\n-->\n<style>`);
  }
  for (const [mark, text] of Object.entries(parts)) page = page.replace(mark, () => text);
  return page;
}

mkdirSync('bundle', { recursive: true });
const made = [];
for (const [name, of] of Object.entries(PAGES)) {
  const page = await bundled(of);
  const file = `bundle/${name}.html`;
  writeFileSync(file, page);
  made.push(file);
  console.log(`${file}: ${Math.round(page.length / 1000)} kB`);
}
const libraries = [...new Set(Object.values(PAGES).flatMap((page) => page.libraries))];
writeFileSync('bundle/LICENSES.md', `# What the bundle has in it\n\n${libraries.map(noticeOf).map(({ title, text }) => `## ${title}\n\n\`\`\`text\n${text}\n\`\`\``).join('\n\n')}\n`);
const hashes = [...SOURCES, ...made, 'bundle/LICENSES.md'].map((name) => `${sha('hex', readFileSync(name))}  ${name}`);
writeFileSync('bundle/SHA256SUMS', `${hashes.join('\n')}\n`);
