package stillwater.report

/** The style sheet of an [HtmlReport], inline in the page. */
internal object HtmlStyle {
    val SHEET: String = """
        :root { --paper: #f6f8f9; --card: #fff; --ink: #1d2529; --muted: #5b6870; --line: #dde3e6; --accent: #0072b2;
          --warn-paper: #fff6e3; --warn-line: #e69f00; }
        @media (prefers-color-scheme: dark) { :root { --paper: #12181c; --card: #1b2328; --ink: #e4eaed;
          --muted: #9aa8b0; --line: #323d44; --accent: #56b4e9; --warn-paper: #2e2615; --warn-line: #e69f00; } }
        * { box-sizing: border-box; }
        body { margin: 0; background: var(--paper); color: var(--ink);
          font: 16px/1.55 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif; }
        header, main, footer { max-width: 60rem; margin: 0 auto; padding: 0 1rem; }
        header { padding-top: 2rem; }
        .brand { margin: 0; color: var(--accent); font-weight: 600; font-size: .85rem; letter-spacing: .08em;
          text-transform: uppercase; }
        h1 { margin: .1rem 0 .3rem; font-size: 2rem; line-height: 1.2; overflow-wrap: anywhere; }
        h2 { margin: 0 0 .7rem; font-size: 1.3rem; line-height: 1.3; overflow-wrap: anywhere; }
        .subtitle { margin: 0 0 1rem; color: var(--muted); font-size: 1.05rem; }
        .answer { font-size: 1.15rem; font-weight: 600; overflow-wrap: anywhere; }
        section { margin: 1.2rem 0; padding: 1.2rem; background: var(--card); border: 1px solid var(--line);
          border-radius: .6rem; }
        section > :last-child, figure > :last-child { margin-bottom: 0; }
        p, dl, pre, figure, details, .scroll, .warnings { margin: 0 0 1rem; }
        figure { text-align: center; }
        .drawing { background: #fff; border-radius: .4rem; overflow: hidden; }
        .drawing svg { display: block; width: 100%; height: auto; max-height: 85vh; margin: 0 auto; }
        figcaption, .caption { margin: .5rem 0 0; color: var(--muted); font-size: .9rem; text-align: left; }
        .caption { margin: 0 0 .4rem; }
        .scroll { overflow-x: auto; }
        table { border-collapse: collapse; min-width: 100%; font-size: .93rem; }
        th, td { padding: .35rem .8rem; text-align: left; border-bottom: 1px solid var(--line); vertical-align: top; }
        th, .number { white-space: nowrap; }
        th { color: var(--muted); font-weight: 600; border-bottom-width: 2px; }
        tbody tr:last-child td { border-bottom: 0; }
        .number { text-align: right; font-variant-numeric: tabular-nums; }
        dl > div { display: grid; grid-template-columns: minmax(9rem, 1fr) 2fr; gap: .2rem 1rem; padding: .25rem 0;
          border-bottom: 1px solid var(--line); }
        dl > div:last-child { border-bottom: 0; }
        dt { color: var(--muted); } dd { margin: 0; overflow-wrap: anywhere; font-variant-numeric: tabular-nums; }
        dl.summary { display: grid; grid-template-columns: repeat(auto-fit, minmax(11rem, 1fr)); gap: .8rem; }
        dl.summary > div { display: block; padding: .7rem .9rem; background: var(--card); border: 1px solid var(--line);
          border-radius: .6rem; }
        dl.summary dt { font-size: .85rem; } dl.summary dd { font-size: 1.15rem; font-weight: 600; }
        nav ul { display: flex; flex-wrap: wrap; gap: .3rem 1.1rem; margin: 0 0 1rem; padding: 0; list-style: none; }
        a { color: var(--accent); }
        code, pre { font-family: ui-monospace, SFMono-Regular, Menlo, Consolas, "DejaVu Sans Mono", monospace;
          font-size: .88em; }
        code { overflow-wrap: anywhere; } pre { overflow-x: auto; padding: .7rem .9rem; background: var(--paper);
          border-radius: .4rem; } pre code { overflow-wrap: normal; }
        details > summary { cursor: pointer; color: var(--accent); } details > div { padding-top: .7rem; }
        .warnings { padding: .7rem 1rem; background: var(--warn-paper); border-left: 4px solid var(--warn-line);
          border-radius: .3rem; } .warnings p { margin: 0; font-weight: 600; } .warnings ul { margin: .2rem 0 0;
          padding-left: 1.2rem; } section .warnings p { font-weight: normal; }
        footer { padding-bottom: 2.5rem; color: var(--muted); font-size: .88rem; } footer p { margin: .2rem 0; }
        @media (max-width: 34rem) { section { padding: .9rem; margin: .9rem -.4rem; } h1 { font-size: 1.6rem; }
          dl > div { grid-template-columns: 1fr; gap: 0; } dl.summary { grid-template-columns: 1fr 1fr; gap: .5rem; } }
        @media print { body { background: #fff; } section { border: 0; padding: 0; break-inside: avoid-page; } }
    """.trimIndent()
}
