// The page of `azimuth view`. The server tells whether it shows a live robot or a recording.

import { element } from './words.js';

/// Returns "live" or "recorded"; throws if the server does not answer.
async function shownHere() {
  const answer = await fetch('health');
  if (!answer.ok) throw new Error((await answer.text()).trim().slice(0, 300) || `the server answers ${answer.status}`);
  return (await answer.json()).shows;
}

async function fillPage(root) {
  if (await shownHere() === 'live') (await import('./live.js')).showLive(root);
  else await (await import('./recorded.js')).showRecorded(root);
}

const untilThen = document.getElementById('waiting');
try {
  await fillPage(document.querySelector('main'));
  untilThen.remove();
} catch (error) {
  untilThen.replaceWith(element('section', { class: 'card trouble', role: 'alert' }, element('b', {}, 'Trouble '),
    `There is nothing to see: ${error.message}. Is azimuth view still running? Load the page again then.`));
}
