// The clock of a job. Browsers slow down those of pages that nobody sees, but not those of workers.
onmessage = ({ data }) => setTimeout(postMessage, data, null);
