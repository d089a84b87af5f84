/** What goes to the studio's server and comes from it. */

import { type Model, type PartEntry, unpack } from "../viewer/model.ts";

export const token = new URLSearchParams(location.search).get("token") ?? "";

export async function ask(path: string, body?: unknown): Promise<Response> {
  const options: RequestInit = { headers: { "X-Yellowiron-Token": token } };
  if (body !== undefined) Object.assign(options, { method: "POST", body: JSON.stringify(body) });
  const answer = await fetch(path, options);
  if (!answer.ok) {
    const text = await answer.text();
    let said = text;
    try {
      said = JSON.parse(text).message ?? text;
    } catch {
      // plain text
    }
    throw new Error(said);
  }
  return answer;
}

export const asked = async <T>(path: string, body?: unknown): Promise<T> => (await ask(path, body)).json() as Promise<T>;
export const packing = async (path: string): Promise<Model<PartEntry>> => unpack(new Uint8Array(await (await ask(path)).arrayBuffer()));

/** Another window decided something, or a build goes on. */
export interface News {
  version: number;
  changes: number;
}

export function listen(heard: (news: News) => void, silent: (silent: boolean) => void): void {
  const events = new EventSource(`events?token=${encodeURIComponent(token)}`);
  events.onmessage = (event) => heard(JSON.parse(event.data));
  events.onerror = () => silent(true);
  events.onopen = () => silent(false);
}
