// Settings as rows: a label and its control. What is being edited keeps its control.

// A length has a unit, which a browser's field of numbers would drop: there 30cm would be 30.
const isLength = row => row.kind === 'number' && row.unit === 'mm';

// What is written for a length: millimetres, or a text with a unit. A comma is the point of many countries.
function length(text) {
  const plain = text.trim().replace(',', '.');
  return Number.isFinite(Number(plain)) ? Number(plain) : plain;
}

function control(row, give, end) {
  // What is refused gives way to what holds, and a length with a unit to its millimetres.
  const set = async (input, value, isGesture) => {
    const text = input.value;
    const isAccepted = await give(input.row, value, isGesture);
    if (!isAccepted || (isLength(row) && input.value === text)) fill(input, input.row, null);
  };
  if (row.kind === 'switch') {
    const box = Object.assign(document.createElement('input'), { type: 'checkbox' });
    box.onchange = () => set(box, box.checked, false);
    return box;
  }
  if (row.kind === 'text' && !row.takes_other) {
    const list = document.createElement('select');
    list.append(...row.names.map(name => Object.assign(document.createElement('option'), { value: name, textContent: name })));
    list.onchange = () => set(list, list.value, false);
    return list;
  }
  const field = document.createElement('input');
  field.type = row.kind === 'number' && !isLength(row) ? 'number' : 'text';
  if (isLength(row)) {
    field.inputMode = 'decimal';
    field.autocomplete = 'off';
    field.onchange = () => (field.value.trim() === '' ? fill(field, field.row, null) : set(field, length(field.value), true));
    field.onblur = end;
    // As in a field of numbers.
    field.onkeydown = event => {
      const step = { ArrowUp: 1, ArrowDown: -1 }[event.key];
      const now = length(field.value);
      if (!step || typeof now !== 'number') return;
      event.preventDefault();
      field.value = Math.max(now + step, field.row.least ?? 0);
      set(field, Number(field.value), true);
    };
  } else if (row.kind === 'number') {
    field.step = row.digits > 0 ? 'any' : 1;
    // Each key that is pressed, or each click of the arrows, is part of one gesture.
    field.onchange = () => (field.value === '' ? fill(field, field.row, null) : set(field, Number(field.value), true));
    field.onblur = end;
  } else {
    field.onchange = () => set(field, field.value, false);
  }
  return field;
}

function fill(input, row, edited = document.activeElement) {
  input.row = row;
  if (row.kind === 'switch') {
    input.checked = row.value;
  } else if (edited !== input) {
    const value = row.value ?? row.such_as ?? '';
    input.value = row.kind === 'number' ? Number(Number(value).toFixed(row.digits + 1)) : value;
  }
  if (row.kind === 'number') {
    if (row.least !== null) input.min = row.least;
    if (row.most !== null) input.max = row.most;
    input.disabled = row.is_optional && row.value === null;
  }
}

/// Shows the rows; `set` takes the row, a value or null, and whether it is part of a gesture that `end` ends; it
/// tells whether the value was accepted.
export function rows(place, list, set, end) {
  const wanted = list.map(row => row.option).join();
  place.set = set;
  if (place.dataset.rows !== wanted) {
    place.dataset.rows = wanted;
    place.replaceChildren();
    for (const row of list) {
      const id = `${place.id}-${row.option}`;
      const label = Object.assign(document.createElement('label'), { htmlFor: id, title: row.tip });
      label.textContent = row.unit && row.unit !== '°' ? `${row.label} (${row.unit})` : row.label;
      const input = control(row, (...given) => place.set(...given), end);
      [input.id, input.title] = [id, row.tip];
      if (row.is_optional) {
        const box = Object.assign(document.createElement('input'), { type: 'checkbox', title: `off: ${row.automatic}` });
        box.setAttribute('aria-label', `choose ${row.label}`);
        box.onchange = () => place.set(input.row, box.checked ? input.row.such_as : null, false);
        const both = Object.assign(document.createElement('div'), { className: 'auto' });
        both.append(box, input);
        input.box = box;
        place.append(label, both);
      } else {
        place.append(label, input);
      }
    }
  }
  list.forEach(row => {
    const input = document.getElementById(`${place.id}-${row.option}`);
    if (input.box) input.box.checked = row.value !== null;
    fill(input, row);
  });
}
