//! Refuses requests that do not come from the page itself.
//!
//! A page of another site can send requests to a local address, and can let its own name lead there (DNS rebinding). So
//! the path holds a random token, `Host` must be the address that was printed, and a request that changes something must
//! state the page as its origin.

use axum::extract::{Request, State};
use axum::http::header::{
    CACHE_CONTROL, CONTENT_SECURITY_POLICY, HOST, HeaderName, HeaderValue, ORIGIN, REFERRER_POLICY,
    X_CONTENT_TYPE_OPTIONS, X_FRAME_OPTIONS,
};
use axum::http::{HeaderMap, Method, StatusCode};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::Semaphore;

/// Requests that are served at the same time.
const MOST: usize = 64;

/// Longest time of a request. Exports of large pictures take longest.
const LONGEST: Duration = Duration::from_secs(600);

/// Only files of the page itself, and pictures that it makes.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; \
    connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// The addresses that the page may have, and the number of requests that may be served.
#[derive(Debug, Clone)]
pub struct Guard {
    hosts: Arc<[String; 2]>,
    free: Arc<Semaphore>,
}

impl Guard {
    /// Makes the guard of a server on a port of the loopback address.
    #[must_use]
    pub fn new(port: u16) -> Self {
        let hosts = [format!("127.0.0.1:{port}"), format!("localhost:{port}")];
        Self { hosts: Arc::new(hosts), free: Arc::new(Semaphore::new(MOST)) }
    }

    /// Returns the reason to refuse a request, if there is one.
    fn refusal(&self, method: &Method, headers: &HeaderMap) -> Option<&'static str> {
        let text = |name: HeaderName| headers.get(name).and_then(|value| value.to_str().ok());
        let Some(host) = text(HOST).filter(|host| self.hosts.iter().any(|own| own == host)) else {
            return Some("the address is not that of the studio");
        };
        match text(ORIGIN) {
            Some(origin) if origin != format!("http://{host}") => {
                return Some("the request comes from another page");
            }
            None if method != Method::GET && method != Method::HEAD => {
                return Some("the request states no origin");
            }
            _ => {}
        }
        let site = headers.get("sec-fetch-site").and_then(|value| value.to_str().ok());
        match site {
            Some("same-origin" | "none") | None => None,
            Some(_) => Some("the request comes from another site"),
        }
    }
}

/// Passes on the requests of the page, and adds the headers that keep the page closed.
pub async fn check(State(guard): State<Guard>, request: Request, next: Next) -> Response {
    if let Some(reason) = guard.refusal(request.method(), request.headers()) {
        return (StatusCode::FORBIDDEN, reason).into_response();
    }
    let Ok(_permit) = guard.free.try_acquire() else {
        return (StatusCode::SERVICE_UNAVAILABLE, "too many requests at the same time")
            .into_response();
    };
    let Ok(mut response) = tokio::time::timeout(LONGEST, next.run(request)).await else {
        return (StatusCode::REQUEST_TIMEOUT, "the request took too long").into_response();
    };
    let headers = response.headers_mut();
    let fixed = HeaderValue::from_static;
    headers.insert(CONTENT_SECURITY_POLICY, fixed(POLICY));
    headers.insert(REFERRER_POLICY, fixed("no-referrer"));
    headers.insert(X_CONTENT_TYPE_OPTIONS, fixed("nosniff"));
    headers.insert(X_FRAME_OPTIONS, fixed("DENY"));
    headers.insert("cross-origin-resource-policy", fixed("same-origin"));
    headers.entry(CACHE_CONTROL).or_insert(fixed("no-store"));
    response
}

#[cfg(test)]
mod tests {
    use super::*;

    fn headers(pairs: &[(&'static str, &'static str)]) -> HeaderMap {
        pairs
            .iter()
            .map(|(name, value)| (HeaderName::from_static(name), HeaderValue::from_static(value)))
            .collect()
    }

    #[test]
    fn other_hosts_origins_and_sites_are_refused() {
        let guard = Guard::new(7000);
        let own = ("host", "127.0.0.1:7000");
        let origin = ("origin", "http://127.0.0.1:7000");
        let passes =
            |method: Method, pairs: &[_]| guard.refusal(&method, &headers(pairs)).is_none();
        assert!(passes(Method::GET, &[own]));
        assert!(passes(Method::GET, &[("host", "localhost:7000")]));
        assert!(passes(Method::POST, &[own, origin, ("sec-fetch-site", "same-origin")]));
        assert!(!passes(Method::POST, &[own]), "a form states an origin");
        assert!(!passes(Method::GET, &[]), "a host must be stated");
        for host in ["evil.example:7000", "127.0.0.1", "127.0.0.1:7001", "127.0.0.1.evil:7000"] {
            assert!(!passes(Method::GET, &[("host", host)]), "{host}");
        }
        for other in
            ["http://evil.example", "null", "https://127.0.0.1:7000", "http://localhost:7000"]
        {
            assert!(!passes(Method::POST, &[own, ("origin", other)]), "{other}");
        }
        assert!(!passes(Method::GET, &[own, ("sec-fetch-site", "cross-site")]));
        assert!(!passes(Method::GET, &[own, ("sec-fetch-site", "same-site")]));
    }
}
