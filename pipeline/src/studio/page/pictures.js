// Picture files that the user gives to the page, and the textures that they become.

import { sendFile } from "./api.js";
import { announce, ask, known, set, valueOf } from "./store.js";
import { make } from "./toolbar.js";

const KINDS = "image/*,.tga,.tif,.tiff,.hdr,.exr";

/** Writes a picture beside a file of the folder. Returns its path from there, or null. */
export async function upload(beside, file) {
  try {
    return (await sendFile(`picture/${encodeURIComponent(beside)}/${encodeURIComponent(file.name)}`, file)).name;
  } catch (error) {
    announce("refused", error.message);
    return null;
  }
}

/** Lets the user choose a picture. `chosen` gets the file. */
export function choosePicture(chosen) {
  const input = make("input", { type: "file", accept: KINDS });
  input.addEventListener("change", () => input.files[0] && chosen(input.files[0]));
  input.click();
}

/** Puts a picture on the mesh of a spec: a texture of its own in the scene, which the object shows. */
export async function putOn(mesh, file) {
  const scene = known.state.scene;
  const image = await upload(scene, file);
  if (!image) return;
  const value = valueOf(scene);
  const object = value?.objects?.findIndex((one) => one.mesh && (!mesh || one.mesh.name === mesh)) ?? -1;
  if (object < 0) return announce("refused", "The scene shows no mesh: add one under Scene, objects.");
  const textures = value.textures || {};
  const stem = image.replace(/\.[^.]*$/, "") || "picture";
  const known_ = Object.entries(textures).find(([, one]) => one.image === image)?.[0];
  let name = known_ || stem;
  for (let k = 2; !known_ && textures[name]; k++) name = `${stem}-${k}`;
  const edits = [];
  if (!value.textures) edits.push(set(["textures"], { [name]: { image } }));
  else if (!known_) edits.push(set(["textures", name], { image }));
  edits.push(set(["objects", object, "mesh", "texture"], name));
  await ask("edit", { file: scene, edits });
}
