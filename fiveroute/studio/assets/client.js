// Asking the server, one request after the other.

/** What the server refuses, in its words. */
class Refused extends Error {
  constructor(status, document) {
    super(document.error || `the studio answers ${status}`);
    this.exists = document.exists || null;
  }
}

class Client {
  constructor(token) {
    this.token = token;
    this.last = Promise.resolve();
  }

  /** The answer to a request; without a body it only reads. */
  ask(address, body) {
    const answer = this.last.then(() => this.send(address, body));
    this.last = answer.catch(() => null);
    return answer;
  }

  async send(address, body) {
    const headers = { "X-Fiveroute-Token": this.token };
    const request = { headers, cache: "no-store" };
    if (body) {
      headers["Content-Type"] = "application/json";
      Object.assign(request, { method: "POST", body: JSON.stringify(body()) });
    }
    let response;
    try {
      response = await fetch(address, request);
    } catch {
      throw new Refused(0, { error: "the studio does not answer; start it again" });
    }
    const document = await response.json();
    if (!response.ok) throw new Refused(response.status, document);
    return document;
  }
}
