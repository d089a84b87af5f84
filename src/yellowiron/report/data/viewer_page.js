// The view in the report's page.

const place = document.getElementById("viewer");
try {
  if (!("DecompressionStream" in window)) throw new Error("no DecompressionStream");
  const packed = atob(document.getElementById("viewer-data").textContent.trim());
  const viewer = new Viewer(place, await unpack(Uint8Array.from(packed, (letter) => letter.charCodeAt(0))));
  document.getElementById("viewer-caption").textContent = "The machine as built: move it, turn it, click a part.";
  window.yellowiron = Object.assign(viewer, { moved });
} catch (error) {
  document.getElementById("viewer-caption").textContent =
    `As drawn in the CAD model. The 3D view needs a browser with WebGL2 (${error.message}).`;
}
