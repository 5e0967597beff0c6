// Bundles the page into one file, in which only the title and the data are missing:
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
const LIBRARIES = ['three', 'uplot'];

const { outputFiles: [script] } = await build({
  entryPoints: ['src/main.js'], bundle: true, minify: true, format: 'iife', target: 'es2022', write: false, legalComments: 'none', charset: 'ascii',
});
// Nothing in it may end the element that it stands in.
const code = script.text.trim().replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');
const style = [readFileSync('node_modules/uplot/dist/uPlot.min.css', 'utf8'), readFileSync('src/style.css', 'utf8')].join('\n').trim();
const notice = LIBRARIES.map((name) => {
  const { version, license } = JSON.parse(readFileSync(`node_modules/${name}/package.json`, 'utf8'));
  const text = readFileSync(`node_modules/${name}/LICENSE`, 'utf8').trim();
  return { title: `${name} ${version}, ${license}`, text };
});
const sha = (kind, text) => createHash('sha256').update(text).digest(kind);
const parts = {
  '@SCRIPT_HASH@': `sha256-${sha('base64', code)}`, '@STYLE@': style, '@SCRIPT@': code,
};
let page = readFileSync('src/template.html', 'utf8').replace('<style>', () => `<!--\nThis page has in it:\n${notice.map(({ title, text }) => `${title}\n${text}`).join('\n\n')}\n-->\n<style>`);
for (const [mark, text] of Object.entries(parts)) page = page.replace(mark, () => text);
mkdirSync('bundle', { recursive: true });
writeFileSync('bundle/page.html', page);
writeFileSync('bundle/LICENSES.md', `# What the bundle has in it\n\n${notice.map(({ title, text }) => `## ${title}\n\n\`\`\`text\n${text}\n\`\`\``).join('\n\n')}\n`);
const hashes = [...SOURCES, 'bundle/page.html', 'bundle/LICENSES.md'].map((name) => `${sha('hex', readFileSync(name))}  ${name}`);
writeFileSync('bundle/SHA256SUMS', `${hashes.join('\n')}\n`);
console.log(`bundle/page.html: ${Math.round(page.length / 1000)} kB`);
