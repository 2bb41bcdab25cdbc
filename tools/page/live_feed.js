// Opens the stream of events from `azimuth view`, supervises it and reopens it.

/// The server sends an event at least every 500 ms. A longer silence is a fault; the second value is the retry
/// interval.
const silentAfter_ms = 1300, again_ms = 1000;

const eventKinds = ['hello', 'trail', 'truth_trail', 'pose', 'truth', 'map', 'path', 'bearings', 'status', 'picture',
  'journal', 'silence',
  'restarted', 'beat', 'missed'];

export class LiveFeed {
  #source = null;
  #heard_ms = performance.now();

  /// `take(kind, data)` receives events. `tell(state, words)` receives the state of the stream: "connecting", "open",
  /// "silent", "gone" or "refused".
  constructor(address, take, tell) {
    this.address = address;
    this.take = take;
    this.tell = tell;
    this.unreadable = 0;
    this.#open();
    setInterval(() => this.#watch(), 100);
    addEventListener('pagehide', () => this.#source?.close());
    addEventListener('pageshow', (event) => { if (event.persisted) this.#open(); });
  }

  #open() {
    this.#source?.close();
    this.#heard_ms = performance.now();
    const source = new EventSource(this.address);
    this.#source = source;
    source.onopen = () => { this.#heard_ms = performance.now(); };
    source.onerror = () => { if (source === this.#source) this.#lose(); };
    for (const kind of eventKinds) source.addEventListener(kind,
      (event) => { if (source === this.#source) this.#read(kind, event.data); });
  }

  #read(kind, text) {
    this.#heard_ms = performance.now();
    let data;
    try {
      data = JSON.parse(text);
    } catch {
      ++this.unreadable;
      return;
    }
    this.tell('open', '');
    this.take(kind, data);
  }

  #watch() {
    const quiet_ms = performance.now() - this.#heard_ms;
    if (this.#source?.readyState === EventSource.OPEN && quiet_ms > silentAfter_ms)
      this.tell('silent', `Nothing has come from azimuth view for ${Math.round(quiet_ms / 1000)} s.`);
  }

  /// Asks the server for the reason of the failure and schedules the next attempt.
  async #lose() {
    const refused = this.#source.readyState === EventSource.CLOSED;
    this.#source.close();
    this.#source = null;
    this.tell('gone', 'azimuth view does not answer. Trying again.');
    setTimeout(() => this.#open(), again_ms);
    if (refused) await this.#ask();
  }

  async #ask() {
    try {
      const stop = new AbortController(), answer = await fetch(this.address, { signal: stop.signal });
      if (answer.ok) return stop.abort();
      const words = (await answer.text()).trim().slice(0, 200);
      this.tell('refused', words || `azimuth view refuses: ${answer.status}`);
    } catch {
      // The next attempt shows whether the server is back.
    }
  }
}
