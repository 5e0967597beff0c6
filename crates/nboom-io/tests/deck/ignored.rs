//! What a deck says without effect.

use super::{lines, read, warnings, with_cards};

#[test]
fn what_has_no_effect_since_other_values_are_zero_is_ignored_with_a_warning() {
    for (cards, symbol, since) in [
        (" THETIK(2)=30.0", "THETIK(2)", "EKNIK(2,1) and (2,2) are 0"),
        (" GAMAIK(3)=30.0,QNIK(1,4)=-1.0", "GAMAIK(3)", "QNIK(3,3) and (3,4) are 0"),
        (" XIKF(4)=2.0,AES(1,1)=1.0,XIKF(1)=1.0", "XIKF(4)", "AES(1,4) to (4,4) are 0"),
        (" RIK1(2,4)=2.0,", "RIK1(2,4)", "AES(1,4) to (4,4) are 0"),
        (" SIK1(3,4)=2.0,AES(1,1)=1.0,XIKF(1)=1.0", "SIK1(3,4)", "AES(1,4) to (4,4) are 0"),
        (" FTHAT=0.0,-1.0,0.0", "FTHAT(2)", "FT is 0"),
        (" FTBAR=0.0,-1.0,0.0", "FTBAR(2)", "FT is 0"),
        (" TINT=1.0", "TINT", "FT is 0"),
        (" TFIN=1.0,FT=0.0", "TFIN", "FT is 0"),
        (" GHAT=0.0,0.0,1.0", "GHAT(3)", "G is 0"),
        (" SH=1.0,0.0,0.0,G=0.0", "GHAT(1)", "G is 0"),
    ] {
        let found = warnings(cards);
        let words = format!("{symbol}: found ");
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(
            found[0].contains(&words)
                && found[0].ends_with(&format!("since {since}; it is ignored"))
        );
    }
    // What they belong to is there, and a release time that means never belongs to any state.
    let cards =
        " THETIK=4*30.0,EKNIK(1,1)=-1.0,-1.0,EKNIK(3,2)=-1.0,-1.0,GAMAIK(1)=1.0,QNIK(1,3)=-1.0,";
    assert_eq!(warnings(cards), [""; 0]);
    let deck = with_cards(" RELTB=1.0,2.0,3.0,1.0E6,").replace("TF=1.0", "TF=1.0,SEGSTT=0,1,2,1,");
    assert_eq!(
        lines(&read(&deck).warnings),
        [
            "a.nml:16:12: RELTB(2): found 2, expected none since SEGSTT(2) is not 0; it is ignored",
            "a.nml:16:16: RELTB(3): found 3, expected none since SEGSTT(3) is not 0; it is ignored",
        ]
    );
}
