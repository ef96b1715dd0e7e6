// A cutter on USB, with the methods of a serial port: bytes out by one endpoint, answers in by another.

// Graphtec, and Silhouette for the Cameo 5α.
const MAKERS = [0x0b4d, 0x3844];
// The endpoints of all models, 0x01 and 0x82.
const OUT = 1, IN = 2;
// A whole number of packets, whatever the speed of the bus.
const LENGTH = 512;

/// Asks for the cutter.
export async function requestUsb() {
  return new UsbPort(await navigator.usb.requestDevice({ filters: MAKERS.map(vendorId => ({ vendorId })) }));
}

class UsbPort {
  #device;

  constructor(device) {
    this.#device = device;
  }

  async open() {
    const device = this.#device;
    await device.open();
    if (!device.configuration) await device.selectConfiguration(1);
    await device.claimInterface(0);
    const done = ({ status }, bytes) => {
      if (status !== 'ok') throw new Error(`the cutter answers ${status}`);
      return bytes;
    };
    this.writable = new WritableStream({ write: async bytes => done(await device.transferOut(OUT, bytes)) });
    this.readable = new ReadableStream({
      pull: async answers => {
        try {
          const got = await device.transferIn(IN, LENGTH);
          answers.enqueue(done(got, new Uint8Array(got.data.buffer, got.data.byteOffset, got.data.byteLength)));
        } catch (error) {
          // There is no other stream.
          this.readable = null;
          throw error;
        }
      },
    }, { highWaterMark: 0 });
  }

  async close() {
    await this.#device.close();
  }
}
