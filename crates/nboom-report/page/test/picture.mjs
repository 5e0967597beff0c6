// Draws docs/pictures/report.png: the top of the page of the sample deck.
//
//     node test/picture.mjs out/n-boom-1970/report.html ../../../docs/pictures/report.png

import { resolve } from 'node:path';
import { chromium } from 'playwright-core';

const [report, picture] = process.argv.slice(2).map((path) => resolve(path));
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
});
const page = await browser.newPage({ viewport: { width: 1120, height: 1010 } });
await page.goto(`file://${report}`);
await page.waitForSelector('html[data-ready]');
await page.click('[data-layer=trails]');
await page.$eval('#time-0', (slider) => { slider.value = 0.36; slider.dispatchEvent(new Event('input')); });
await page.evaluate(() => { document.activeElement.blur(); scrollTo(0, 0); });
await page.screenshot({ path: picture });
await browser.close();
