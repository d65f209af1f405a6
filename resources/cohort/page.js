'use strict';
(() => {
  const cards = [...document.querySelectorAll('article')];
  // Another cohort may have been here.
  const key = 'tidemark-cohort:' + location.pathname + ' ' + document.body.dataset.plan;
  let decisions = {};
  try { decisions = JSON.parse(localStorage.getItem(key)) || {}; } catch (error) { decisions = {}; }
  // What the folder keeps of a case, and which result that is about.
  const kept = ({ decision = '', comment = '', finished }) => JSON.stringify([decision, comment, finished]);
  // What was said here stays where the folder still keeps what it did then.
  for (const card of cards) {
    const { id, decision = '', comment = '' } = card.dataset;
    const folder = kept(card.dataset);
    if (decisions[id] && decisions[id].folder === folder) continue;
    delete decisions[id];
    if (decision || comment) decisions[id] = { decision, comment, folder };
  }
  let saved = true;

  const show = (card) => {
    const one = decisions[card.dataset.id] || {};
    card.classList.toggle('accept', one.decision === 'accept');
    card.classList.toggle('reject', one.decision === 'reject');
    const words = { accept: '✓ accepted', reject: '✗ rejected' }[one.decision] || '';
    card.querySelector('.verdict').textContent = [words, one.comment].filter(Boolean).join(': ');
  };
  const count = () => {
    const all = Object.values(decisions);
    const of = (word) => all.filter((one) => one.decision === word).length;
    document.getElementById('count').textContent =
      `${of('accept')} accepted, ${of('reject')} rejected, ${cards.length} cases`;
  };
  const change = (card, part) => {
    decisions[card.dataset.id] = { ...decisions[card.dataset.id], ...part, folder: kept(card.dataset) };
    saved = false;
    try { localStorage.setItem(key, JSON.stringify(decisions)); } catch (error) { /* a full or closed store */ }
    show(card);
    count();
  };
  // The keys are for the card that had the focus last: a click beside the cards, or on a button, takes it away.
  let current = null;
  for (const card of cards) {
    card.addEventListener('focusin', () => {
      if (current) current.classList.remove('current');
      current = card;
      card.classList.add('current');
    });
  }
  const go = (by) => {
    const next = cards[Math.min(cards.length - 1, Math.max(0, cards.indexOf(current) + by))];
    if (next) { next.focus({ preventScroll: true }); next.scrollIntoView({ block: 'nearest' }); }
  };
  // As a table's field, and never a formula of a spreadsheet.
  const field = (text) => '"' + (/^[=+\-@\t\r]/.test(text) ? "'" : '') + text.replace(/"/g, '""') + '"';

  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const card = current;
    const move = { j: () => go(1), k: () => go(-1) };
    const decide = {
      a: () => { change(card, { decision: 'accept' }); go(1); },
      r: () => { change(card, { decision: 'reject' }); go(1); },
      u: () => change(card, { decision: '', comment: '' }),
      c: () => {
        const comment = prompt('Comment on ' + card.dataset.id, (decisions[card.dataset.id] || {}).comment || '');
        if (comment !== null) change(card, { comment: comment.slice(0, 1000) });
      },
    };
    const act = move[event.key] || (card && decide[event.key]);
    if (act) { event.preventDefault(); act(); }
  });
  document.getElementById('save').addEventListener('click', () => {
    const lines = ['id,decision,comment'];
    for (const card of cards) {
      const one = decisions[card.dataset.id];
      if (one && (one.decision || one.comment)) lines.push([card.dataset.id, one.decision || '', field(one.comment || '')].join(','));
    }
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([lines.join('\r\n') + '\r\n'], { type: 'text/csv' }));
    link.download = 'decisions.csv';
    link.click();
    URL.revokeObjectURL(link.href);
    saved = true;
    if (current) current.focus({ preventScroll: true });
  });
  window.addEventListener('beforeunload', (event) => { if (!saved) event.preventDefault(); });
  for (const card of cards) if (decisions[card.dataset.id]) show(card);
  count();
})();
