// What every page has: a list of errors for tests, buttons that copy, and what is folded in print.
const page = window.ceresEd = {ready: false, errors: []};
window.addEventListener('error', (event) => page.errors.push(String(event.message)));
const byId = (id) => document.getElementById(id);
const on = (id, event, action) => { if (byId(id)) byId(id).addEventListener(event, action); };

for (const button of document.querySelectorAll('button.copy')) {
  button.addEventListener('click', () => {
    const text = button.parentElement.querySelector('pre').textContent;
    const done = () => { button.textContent = 'Copied'; };
    if (navigator.clipboard) navigator.clipboard.writeText(text).then(done, () => {});
  });
}
window.addEventListener('beforeprint', () => {
  for (const part of document.querySelectorAll('details')) part.open = true;
});
