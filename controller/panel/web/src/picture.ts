// SPDX-License-Identifier: Apache-2.0
// A chosen photograph as it is sent. Large ones are made smaller first: the light is the same, the
// upload a hundredth. What the browser cannot read goes as it is, so that the daemon says why not.

const most = 1600;

export async function uploadOf(file: File): Promise<Blob> {
  const bitmap = await createImageBitmap(file).catch(() => null);
  if (!bitmap) return file;
  const scale = Math.min(1, most / Math.max(bitmap.width, bitmap.height));
  if (scale === 1) return file;
  const canvas = document.createElement('canvas');
  canvas.width = Math.max(1, Math.round(bitmap.width * scale));
  canvas.height = Math.max(1, Math.round(bitmap.height * scale));
  const context = canvas.getContext('2d');
  if (!context) return file;
  context.fillStyle = '#777'; // behind what is transparent, as the daemon does it
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.drawImage(bitmap, 0, 0, canvas.width, canvas.height);
  bitmap.close();
  const smaller = await new Promise<Blob | null>((made) => canvas.toBlob(made, 'image/jpeg', 0.92));
  return smaller ?? file;
}

/** "IMG_2041.jpeg" to "IMG 2041". */
export function titleOf(file: File): string {
  return file.name.replace(/\.\w+$/, '').replace(/[_-]+/g, ' ').trim() || 'Own picture';
}

/** What an <img> shows now, as an address of its own; '' when it shows nothing. */
export function snapshot(picture: HTMLImageElement): string {
  if (!picture.naturalWidth) return '';
  const canvas = document.createElement('canvas');
  canvas.width = picture.naturalWidth;
  canvas.height = picture.naturalHeight;
  canvas.getContext('2d')?.drawImage(picture, 0, 0);
  return canvas.toDataURL('image/jpeg', 0.92);
}
