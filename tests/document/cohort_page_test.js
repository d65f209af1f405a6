// The keys of a cohort's report page (resources/cohort/page.js), on a page of stubs: cohort_page_test.js SOURCE
'use strict';
const assert = require('assert');
const fs = require('fs');
const path = require('path');
const vm = require('vm');

class Element {
  constructor(dataset = {}) { this.dataset = dataset; this.listeners = {}; this.classes = new Set(); this.textContent = ''; }
  get classList() {
    return { add: (name) => this.classes.add(name), remove: (name) => this.classes.delete(name),
      toggle: (name, on) => (on ? this.classes.add(name) : this.classes.delete(name)) };
  }
  addEventListener(name, listener) { (this.listeners[name] ||= []).push(listener); }
  send(name, event = {}) { for (const listener of this.listeners[name] || []) listener({ preventDefault() {}, ...event }); }
  focus() { page.activeElement = this; this.send('focusin'); }
  closest() { return this.dataset.id ? this : null; }
  querySelector() { return this.verdict ||= new Element(); }
  scrollIntoView() {}
  click() { this.send('click'); }
}

const cards = ['a', 'b', 'c'].map((id) => new Element({ id, finished: 'today' }));
const body = new Element({ plan: 'plan' });
const parts = { save: new Element(), count: new Element() };
const page = new Element();
Object.assign(page, { body, activeElement: body, querySelectorAll: () => cards, getElementById: (id) => parts[id],
  createElement: () => new Element() });
const script = path.join(process.argv[2], 'resources/cohort/page.js');
vm.runInNewContext(fs.readFileSync(script, 'utf8'), {
  document: page, window: new Element(), location: { pathname: '/' }, localStorage: { getItem: () => null, setItem() {} },
  URL: { createObjectURL: () => '', revokeObjectURL() {} }, Blob: class {}, prompt: () => 'seen' });

const press = (key) => page.send('keydown', { key });
const verdicts = () => cards.map((card) => card.verdict?.textContent || '');

// Nothing is decided before a card is chosen.
for (const key of ['a', 'r', 'u', 'c']) press(key);
assert.deepStrictEqual(verdicts(), ['', '', '']);

press('j');
press('r');
assert.deepStrictEqual(verdicts(), ['✗ rejected', '', '']);
assert.strictEqual(page.activeElement, cards[1]);

// A click focuses the button; the keys go on with the second card.
page.activeElement = parts.save;
parts.save.click();
press('a');
assert.deepStrictEqual(verdicts(), ['✗ rejected', '✓ accepted', '']);
// So they do after a click beside the cards.
page.activeElement = body;
press('c');
press('k');
press('u');
assert.deepStrictEqual(verdicts(), ['✗ rejected', '', 'seen']);
assert.ok(cards[1].classes.has('current') && !cards[2].classes.has('current'));
