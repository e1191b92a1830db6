'use strict';
// Nodes of the page.
const reportDom = (() => {
  const $ = (id) => document.getElementById(id);

  function make(name, properties = {}, ...children) {
    const node = Object.assign(document.createElement(name), properties);
    node.append(...children);
    return node;
  }

  const complaint = (text) => make('p', {className: 'complaint', textContent: text});

  return {$, make, complaint};
})();
