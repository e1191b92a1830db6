// SPDX-License-Identifier: Apache-2.0
/// As much of a document as the panels' small parts need; text nodes are real enough for set_text.

class FakeText {
  parent: FakeNode | null = null;
  constructor(public data: string) {}
  get textContent(): string { return this.data; }
}

export class FakeNode {
  readonly kids: (FakeNode | FakeText)[] = [];
  readonly attributes = new Map<string, string>();
  parent: FakeNode | null = null;
  hidden = false;
  value = '';
  readonly dataset = {};
  readonly style = {setProperty: () => undefined};

  constructor(readonly tag: string) {}

  get children(): FakeNode[] {
    return this.kids.filter((kid): kid is FakeNode => kid instanceof FakeNode);
  }
  get firstChild() { return this.kids[0] ?? null; }
  get lastChild() { return this.kids.at(-1) ?? null; }
  get textContent(): string { return this.kids.map(({textContent}) => textContent).join(''); }
  set textContent(words: string) { this.kids.splice(0, Infinity, new FakeText(words)); }

  hasAttribute(name: string): boolean { return this.attributes.has(name); }
  getAttribute(name: string): string | null { return this.attributes.get(name) ?? null; }
  setAttribute(name: string, value: string): void { this.attributes.set(name, value); }
  removeAttribute(name: string): void { this.attributes.delete(name); }
  addEventListener(): void { /* nobody clicks */ }

  append(...kids: (FakeNode | string)[]): void {
    for (const kid of kids) {
      this.insertBefore(typeof kid === 'string' ? new FakeText(kid) : kid, null);
    }
  }
  insertBefore(kid: FakeNode | FakeText, before: FakeNode | null): void {
    kid.parent?.kids.splice(kid.parent.kids.indexOf(kid), 1);
    kid.parent = this;
    this.kids.splice(before === null ? this.kids.length : this.kids.indexOf(before), 0, kid);
  }
  replaceChildren(...kids: FakeNode[]): void {
    this.kids.length = 0;
    this.append(...kids);
  }
  querySelectorAll(): FakeNode[] { return []; }
  matches(): boolean { return false; }
  get options(): FakeNode[] {
    return this.children.map((kid) => Object.assign(kid, {value: kid.getAttribute('value')}));
  }
  /// The first of an id or tag, however deep.
  find(what: string): FakeNode | undefined {
    return this.getAttribute('id') === what || this.tag === what ? this
      : this.children.map((kid) => kid.find(what)).find((found) => found !== undefined);
  }
  remove(): void {
    this.parent?.kids.splice(this.parent.kids.indexOf(this), 1);
    this.parent = null;
  }
}

/// For the rest of the test file.
export function fake_document(): void {
  Object.assign(globalThis,
    {document: {createElement: (tag: string) => new FakeNode(tag)}, Text: FakeText});
}
