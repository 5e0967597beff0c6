// The page: sections in the order in which people ask.

import { account, envelopes, sceneText } from './account.js';
import { eventTable } from './events.js';
import { figuresOf } from './curves.js';
import { Motion } from './motion.js';
import { Figure } from './plot.js';
import { Player } from './player.js';
import { Run } from './run.js';
import { element, given, note, section } from './text.js';
import { colours, isDark, switchTheme, themeButton } from './theme.js';
import { angles } from './units.js';
import { comparison, verdictSection, withoutPulses } from './verdict.js';
import { Animation } from './view/animation.js';
import { comparedFigures } from './compare.js';

const page = JSON.parse(document.getElementById('data').textContent);
const runs = page.runs.map((data, number) => new Run(data, number));
const [first] = runs;
const several = runs.length > 1;

/** What the page shows now. */
const shown = { figures: [], animation: null, player: null };

function header() {
  const unit = element('select', { 'aria-label': 'Unit of angles', id: 'angles', change: ({ target }) => { angles.inDegrees = target.value === 'degrees'; build(); } },
    ['degrees', 'radians'].map((name) => element('option', { value: name, selected: (name === 'degrees') === angles.inDegrees }, name)));
  const title = several ? `${runs.length} runs` : first.name;
  const { summary } = first;
  const about = several ? runs.map(({ name }) => name).join(' · ') : summary ? `nboom ${summary.version} · ${summary.formulation} · ${summary.integrator}` : '';
  return element('header', {},
    element('div', {}, element('h1', {}, given(title)), element('p', { class: 'about' }, about)),
    element('div', { class: 'tools' }, element('label', {}, 'Angles in ', unit), themeButton(redraw)));
}

function motionSection() {
  const candidates = runs.filter((run) => run.motion && run.scene && new Motion(run).isWhole);
  if (candidates.length === 0) {
    const player = first.motion ? new Player(first, showTime) : null;
    shown.player = player;
    return section('motion', 'Motion', note('There is no picture, since the scene or the motion is missing.'), player?.element);
  }
  const place = element('div', {});
  const choose = (run) => {
    shown.player?.pause();
    shown.animation = new Animation(run, colours());
    shown.player = new Player(run, showTime);
    place.replaceChildren(shown.animation.element, shown.player.element);
    shown.animation.attach();
    shown.player.go(run.span[0]);
  };
  shown.start = () => choose(candidates[0]);
  const choice = candidates.length > 1
    ? element('label', { class: 'choice' }, 'Run ', element('select', { change: ({ target }) => choose(candidates[target.value]) },
      candidates.map(({ name }, i) => element('option', { value: i }, name))))
    : null;
  return section('motion', 'Motion', choice, place,
    element('p', { class: 'keyboard' }, 'Keys: space plays, ← and → step, n and p go to events, Home and End to the ends, v changes the view, t the colours.'));
}

function showTime(time) {
  shown.animation?.show(time);
  shown.figures.forEach((figure) => figure.at(time));
  document.querySelectorAll('tr.event').forEach((row) => row.classList.toggle('now', Number(row.dataset.t) === time));
}

function go(time) {
  shown.player?.pause();
  shown.player?.go(time);
}

function curveSection() {
  const place = element('div', { class: 'curves' });
  if (several) return section('curves', 'Curves', comparedFigures(runs, place, shown, go));
  const events = [...new Set(first.events.filter(({ kind }) => kind !== 'end').map(({ t }) => t))];
  shown.figures = figuresOf(first).map((figure) => new Figure({ ...figure, events, timeUnit: first.units.time, go }));
  place.append(...shown.figures.map((figure) => figure.element));
  return section('curves', 'Curves', place);
}

function build() {
  const time = shown.player?.time;
  const main = element('main', {}, several ? comparison(runs) : verdictSection(first), motionSection());
  if (!several) {
    if (first.events.length > 0) main.append(section('events', 'Events', eventTable(first, go)));
  }
  main.append(curveSection());
  const loads = several ? null : envelopes(first);
  if (loads) main.append(section('loads', `Largest loads${withoutPulses(first)}`, loads));
  runs.forEach((run) => {
    const of = several ? `: ${run.name}` : '';
    if (run.summary) main.append(section(`account-${run.number}`, `How it was run${of}`, account(run)));
    main.append(section(`scene-${run.number}`, `The scene as read${of}`, sceneText(run)));
  });
  document.body.replaceChildren(...document.querySelectorAll('script'), header(), main);
  shown.start?.();
  if (time !== undefined) shown.player?.go(time);
  document.documentElement.dataset.picture = String(Math.round(performance.now()));
  // Curves come after the first picture.
  setTimeout(() => { redraw(); document.documentElement.dataset.ready = ''; }, 0);
}

function redraw() {
  const chosen = { ...colours(), dark: isDark() };
  shown.figures.forEach((figure) => figure.draw(chosen));
  shown.animation?.recolour(chosen);
  if (shown.player) shown.player.go(shown.player.time);
}

addEventListener('resize', () => { shown.animation?.fit(); shown.figures.forEach((figure) => figure.resize()); });
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', redraw);
addEventListener('beforeprint', () => { document.documentElement.dataset.print = ''; document.querySelectorAll('details').forEach((part) => { part.open = true; }); redraw(); });
addEventListener('afterprint', () => { delete document.documentElement.dataset.print; redraw(); });
addEventListener('keydown', (event) => {
  const { key, target, ctrlKey, metaKey, altKey } = event;
  if (ctrlKey || metaKey || altKey || /^(SELECT|TEXTAREA)$/.test(target.tagName)) return;
  if ((key === ' ' || key === 'Enter') && /^(BUTTON|SUMMARY)$/.test(target.tagName)) return;
  const done = shown.player?.key(key) || (key === 'v' && shown.animation?.turnView()) || (key === 't' && switchTheme(redraw));
  if (done) event.preventDefault();
});

build();
